"""Publish every message type with a generated node, and receive it in another process.

    python benchmarks/publish_all_types.py [--jobs N] [--keep DIRECTORY] [TYPE...]

For each TYPE, by default all messages of the installed interface packages, `new` writes a package
with a publisher. The nodes are started as they are, N at a time; a process of its own subscribes
to all of them. A type is right when its messages arrive, differ from a message whose fields keep
their defaults, differ from each other, and fulfil the checks that the generated test makes too.
Types without fields must only arrive. Printed are the types that are not right, and how many are.
The exit status is 1 when a type is not right.

ROS 2 is that of this Python: its interpreter must be able to import rclpy and the messages.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from contextlib import ExitStack
from importlib.util import find_spec
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from scaffold.generate import payload
from scaffold.model.interfaces.definitions import Definitions
from scaffold.model.interfaces.sources import PrefixSource
from scaffold.smoke import environment
from scaffold.smoke.isolation import domain
from tests.generate.payload.publishing import Publisher, receive
from tests.generate.payload.test_payload import write


def main() -> int:
    """Run the comparison."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("types", nargs="*", metavar="TYPE")
    parser.add_argument("--jobs", type=int, default=4, metavar="N")
    parser.add_argument("--keep", metavar="DIRECTORY", help="where the packages are written")
    options = parser.parse_args()
    os.environ.setdefault("AMENT_PREFIX_PATH", sys.prefix)  # where `new` looks for messages
    definitions = installed()
    with ExitStack() as stack:
        scratch = stack.enter_context(tempfile.TemporaryDirectory())
        directory = Path(options.keep or scratch)
        wanted = [
            publisher(directory, name, definitions) for name in options.types or names(definitions)
        ]
        variables = {
            **environment.select(os.environ).variables,
            "ROS_DOMAIN_ID": str(stack.enter_context(domain.reserved())),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ROS_LOG_DIR": scratch,
        }
        start = time.monotonic()
        good = empty = 0
        for received in receive(wanted, variables, Path(scratch), jobs=options.jobs):
            good += received.is_good
            empty += received.is_good and not received.publisher.payload.is_changing
            if not received.is_good:
                print(received.publisher.payload.type, received._replace(output=""))
                print(received.output[-1000:])
    print(
        f"{good} of {len(wanted)} types published and received in "
        f"{time.monotonic() - start:.0f} s; {empty} of them have no fields"
    )
    return int(good < len(wanted))


def installed() -> Definitions:
    """Return the interfaces of this Python's environment."""
    return Definitions([PrefixSource([sys.prefix])])


def names(definitions: Definitions) -> list[str]:
    """Return the importable messages."""
    return [
        name
        for name in definitions.all_names()
        if "/msg/" in name and find_spec(name.partition("/")[0]) is not None
    ]


def publisher(directory: Path, name: str, definitions: Definitions) -> Publisher:
    """Write the package for a type."""
    filled = payload.payload(name, definitions)
    package = f"{filled.package}_{filled.name.lower()}"[:48]
    written = write(directory, package=package, node_name="talker", message_type=filled.type)
    return Publisher(filled, written / package / "talker.py", f"/{package}")


if __name__ == "__main__":
    sys.exit(main())
