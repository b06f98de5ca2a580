from . import impl as impl
from .impl import domain_id as domain_id
