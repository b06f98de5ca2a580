from typing import Any
from .evaluate_parameters import evaluate_parameters as evaluate_parameters
from .namespace_utils import is_namespace_absolute as is_namespace_absolute
from .namespace_utils import is_root_namespace as is_root_namespace
from .namespace_utils import make_namespace_absolute as make_namespace_absolute
from .namespace_utils import prefix_namespace as prefix_namespace
from .normalize_parameters import normalize_parameters as normalize_parameters
from .normalize_remap_rule import normalize_remap_rule as normalize_remap_rule
from .normalize_remap_rule import normalize_remap_rules as normalize_remap_rules
from .to_parameters_list import to_parameters_list as to_parameters_list
from .track_node_names import add_node_name as add_node_name
from .track_node_names import get_node_name_count as get_node_name_count

def __getattr__(name: str) -> Any: ...
