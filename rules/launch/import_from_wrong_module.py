"""LF043: classes of launch are imported from where they are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, PythonRule, Report
from scaffold.api.python import Import, PythonModule

_NAMES: Mapping[str, str] = {
    "launch": "LaunchContext LaunchDescription LaunchDescriptionSource LaunchService actions "
    "conditions descriptions events frontend logging substitutions Action Condition Event "
    "EventHandler InvalidLaunchFileError LaunchDescriptionEntity LaunchIntrospector "
    "SomeEntitiesType SomeSubstitutionsType Substitution event_handlers utilities",
    "launch.actions": "AppendEnvironmentVariable DeclareLaunchArgument EmitEvent ExecuteLocal "
    "ExecuteProcess GroupAction IncludeLaunchDescription LogInfo OpaqueCoroutine OpaqueFunction "
    "PopEnvironment PopLaunchConfigurations PushEnvironment PushLaunchConfigurations "
    "ResetEnvironment ResetLaunchConfigurations RegisterEventHandler SetEnvironmentVariable "
    "SetLaunchConfiguration Shutdown TimerAction UnregisterEventHandler "
    "UnsetEnvironmentVariable UnsetLaunchConfiguration",
    "launch.substitutions": "AndSubstitution AnySubstitution AllSubstitution AnonName Command "
    "EnvironmentVariable EqualsSubstitution FileContent FindExecutable IfElseSubstitution "
    "LaunchConfiguration LaunchLogDir LocalSubstitution NotEqualsSubstitution NotSubstitution "
    "OrSubstitution PathJoinSubstitution PythonExpression SubstitutionFailure TextSubstitution "
    "ThisLaunchFile ThisLaunchFileDir "
    "PathSubstitution StringJoinSubstitution ForLoopIndex",
    "launch.conditions": "IfCondition LaunchConfigurationEquals LaunchConfigurationNotEquals "
    "UnlessCondition",
    "launch.event_handlers": "OnExecutionComplete OnIncludeLaunchDescription OnProcessExit "
    "OnProcessIO OnProcessStart OnShutdown",
    "launch.launch_description_sources": "AnyLaunchDescriptionSource "
    "FrontendLaunchDescriptionSource PythonLaunchDescriptionSource",
    "launch_xml.launch_description_sources": "XMLLaunchDescriptionSource",
    "launch_yaml.launch_description_sources": "YAMLLaunchDescriptionSource",
    "launch_ros.actions": "ComposableNodeContainer LifecycleNode LifecycleTransition "
    "LoadComposableNodes Node PushROSNamespace PushRosNamespace ROSTimer RosTimer SetParameter "
    "SetParametersFromFile SetRemap SetROSLogDir SetUseSimTime",
    "launch_ros.substitutions": "ExecutableInPackage FindPackage FindPackagePrefix "
    "FindPackageShare Parameter",
    "launch_ros.descriptions": "ComposableNode Parameter ParameterFile ParameterValue",
    "launch_ros.parameter_descriptions": "Parameter ParameterFile ParameterValue",
    "launch_ros": "actions descriptions substitutions",
    "ament_index_python.packages": "get_package_prefix get_package_share_directory "
    "get_package_share_path get_packages_with_prefixes PackageNotFoundError",
}
_LAUNCH = "from {} import Node\nfrom launch.actions import {}\n"


class ImportFromWrongModule(PythonRule):
    """A name of launch is imported from a module that does not have it.

    **Why.** ``ros2 launch`` stops: ``ImportError: cannot import name 'Node' from
    'launch.actions'``.

    **Fix.** Import it from the module that is named.

    **Source.** The packages launch, launch_ros and ament_index_python of Jazzy.
    """

    code = "LF043"
    name = "import-from-wrong-module"
    examples = (
        Example(
            "right", {"launch/a.launch.py": _LAUNCH.format("launch_ros.actions", "TimerAction")}
        ),
        Example(
            "wrong, and misspelled",
            {"launch/a.launch.py": _LAUNCH.format("launch.actions", "TimerActions")},
            Report("1:28", "launch.actions has no 'Node'; launch_ros.actions has"),
            Report("2:28", "launch.actions has no 'TimerActions'; closest: 'TimerAction'"),
        ),
        Example(
            "a module that does not exist",
            {"launch/a.launch.py": _LAUNCH.format("launch_ros.action", "TimerAction")},
            Report("1:1", "no module 'launch_ros.action'; closest: 'launch_ros.actions'"),
        ),
    )

    def paths(self, package: Package) -> Sequence[str]:
        """Return the Python files of a package that does not define these modules."""
        roots = {module.partition(".")[0] for module in _NAMES}
        return () if package.name in roots else super().paths(package)

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        names_of = {module: frozenset(names.split()) for module, names in _NAMES.items()}
        places = {name: module for module, names in names_of.items() for name in names}
        roots = {module.partition(".")[0] for module in names_of}
        for root in roots:
            for item in module.imports_by_root.get(root, ()):
                if not item.guarded and not item.conditional:
                    yield from self._check(item, names_of, places)

    def _check(
        self, node: Import, names_of: Mapping[str, frozenset[str]], places: Mapping[str, str]
    ) -> Iterator[Diagnostic]:
        plural = f"{node.module}s"
        if node.module not in names_of and plural in names_of and node.root != "launch":
            yield self.report(node, f"no module {node.module!r}; closest: {plural!r}")
        for name in node.names if node.module in names_of else ():
            if name.name in names_of[node.module] or name.name == "*":
                continue
            place = places.get(name.name)
            alike = get_close_matches(name.name, names_of[node.module], 1, 0.85)
            if place is None and alike and alike[0].lower() != name.name.lower():
                hint = f"closest: {alike[0]!r}"
            elif place is not None and place.count(".") >= node.module.count("."):
                hint = f"{place} has"
            else:
                continue
            yield self.report(name, f"{node.module} has no {name.name!r}; {hint}")
