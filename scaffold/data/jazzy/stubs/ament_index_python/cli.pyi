# Made by scripts/make_stubs.py from ament_index_python 1.8.1 of ROS 2 Jazzy; do not edit.
import argparse
from typing import Any, Dict, Generator, List, Optional, Tuple, Union
from ament_index_python.resources import get_resource as get_resource
from ament_index_python.resources import get_resource_types as get_resource_types
from ament_index_python.resources import get_resources as get_resources

def main(argv: List[str] = ...) -> Optional[str]: ...
def resource_type_completer(
    prefix: Union[str, Tuple[str, ...]], **kwarg: Dict[str, Any]
) -> Generator[str, None, None]: ...
def resource_name_completer(
    prefix: Union[str, Tuple[str, ...]], parsed_args: argparse.Namespace, **kwargs: Dict[str, Any]
) -> Union[Generator[str, None, None], List[str]]: ...
