"""CM019: installed directories keep their name."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.launch import DATA_DIRECTORIES

DIRECTORIES = ("launch", *DATA_DIRECTORIES)
_LISTS = "project(talker)\ninstall(DIRECTORY {} DESTINATION share/${{PROJECT_NAME}}{})\n"
_FILES = {"config/talker.yaml": ""}


class SharePathDiffers(Rule):
    """``install(DIRECTORY ...)`` drops or doubles the name of the directory.

    **Why.** ``config/`` with a slash installs what is in it, without it the directory itself:
    files land in ``share/<package>/`` or in ``share/<package>/config/config/``, where no launch
    file looks for them.

    Only ``ros2 launch`` finds its files wherever they land.

    **Fix.** Write ``install(DIRECTORY config DESTINATION share/${PROJECT_NAME})``.

    **Source.** CMake documentation, ``install(DIRECTORY)``.
    """

    code = "CM019"
    name = "share-path-differs"
    severity = Severity.WARNING
    examples = (
        Example(
            "both ways that keep it",
            {
                **_FILES,
                "CMakeLists.txt": _LISTS.format("config", "") + _LISTS.format("config/", "/config"),
            },
        ),
        Example(
            "launch files, which are found anywhere",
            {"launch/talk.launch.py": "", "CMakeLists.txt": _LISTS.format("launch/", "")},
        ),
        Example(
            "dropped",
            {**_FILES, "CMakeLists.txt": _LISTS.format("config/", "")},
            Report(
                "CMakeLists.txt:2:19",
                "the files of config/ are installed to share/talker/, not in share/talker/config/",
                fix="keep config/ once",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("config", "")},
        ),
        Example(
            "doubled",
            {**_FILES, "CMakeLists.txt": _LISTS.format("config", "/config")},
            Report(
                "CMakeLists.txt:2:19",
                "the files of config/ are installed to share/talker/config/config/, "
                "not in share/talker/config/",
                fix="keep config/ once",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("config/", "/config")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        name = package.cmake.project_name
        for install in package.cmake.installs:
            target = (install.destination or "").rstrip("/")
            if install.kind != "DIRECTORY" or install.command.name != "install":
                continue
            for item in install.items:
                written = item.argument.value
                directory = item.path or ""
                if directory not in DIRECTORIES or item.argument.quoted:
                    continue
                slash = written.endswith("/")
                if slash and target == f"share/{name}" and directory != "launch":
                    end = item.argument.end
                    edit = Edit("CMakeLists.txt", end - 1, end, "")
                    lands = f"{target}/, not in {target}/{directory}/"
                elif not slash and target == f"share/{name}/{directory}":
                    end = item.argument.end
                    edit = Edit("CMakeLists.txt", end, end, "/")
                    lands = f"{target}/{directory}/, not in {target}/"
                else:
                    continue
                message = f"the files of {directory}/ are installed to {lands}"
                yield self.report(item, message, Fix(f"keep {directory}/ once", (edit,)))
