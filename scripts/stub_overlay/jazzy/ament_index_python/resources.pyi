from typing import Set
