"""SP005: options in setup.cfg have underscores."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.distributions import target

_STOPPING = 78
"""The first setuptools that rejected dashes; 78.0.2 postponed that."""
_CFG = "[develop]\nscript{0}dir=$base/lib/talker\n[install]\ninstall{0}scripts=$base/lib/talker\n"


class SetupCfgKeyDashed(Rule):
    """An option of setup.cfg contains a dash.

    **Why.** setuptools warns in every build, and newer versions stop: ``Usage of dash-separated
    'script-dir' will not be supported``.

    **Fix.** Write an underscore.

    **Source.** ros2cli issue 730; setuptools, changes of version 78.
    """

    code = "SP005"
    name = "setup-cfg-key-dashed"
    severity = Severity.WARNING
    is_fixed_for_all = True
    is_deprecation = True
    examples = (
        Example("underscores", {"setup.py": "", "setup.cfg": _CFG.format("_")}),
        Example(
            "dashes",
            {"setup.py": "", "setup.cfg": _CFG.format("-")},
            Report(
                "setup.cfg:2:1",
                "use 'script_dir' instead of 'script-dir'",
                fix="Replace with script_dir",
            ),
            Report(
                "setup.cfg:4:1",
                "use 'install_scripts' instead of 'install-scripts'",
                fix="Replace with install_scripts",
            ),
            fixed={"setup.cfg": _CFG.format("_")},
        ),
        Example(
            "dashes, with a setuptools that will stop",
            {"setup.py": "", "setup.cfg": "[develop]\nscript-dir=$base/lib/talker\n"},
            Report(
                "setup.cfg:2:1",
                "setuptools 78.1.1 of Lyrical will stop at 'script-dir' in a later "
                "version; use 'script_dir' instead of 'script-dir'",
                fix="Replace with script_dir",
            ),
            fixed={"setup.cfg": "[develop]\nscript_dir=$base/lib/talker\n"},
            distro="lyrical",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if not package.has("setup.py"):
            return
        cfg = package.setup_cfg
        for option in cfg.options:
            if option.section not in {"develop", "install", "metadata", "options"}:
                continue
            if "-" in option.key:
                right = option.key.replace("-", "_")
                message = f"use {right!r} instead of {option.key!r}"
                setuptools = target().fact("setuptools")
                if int(setuptools.partition(".")[0]) >= _STOPPING:
                    message = (
                        f"setuptools {setuptools} of {target().title} will stop at {option.key!r} "
                        f"in a later version; {message}"
                    )
                fix = Fix(f"Replace with {right}", (cfg.rename(option, right),))
                yield self.report(option.key_location, message, fix)
