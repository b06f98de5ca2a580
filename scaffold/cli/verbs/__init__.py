"""The verbs of the command line: one module each, with flags and implementation."""

from __future__ import annotations

VERBS = {
    "new": "create a package",
    "add": "add a node, an interface, a program or a launch file to a package",
    "update": "update a package to the current templates",
    "check": "lint packages and find what will break",
    "migrate": "migrate packages to another ROS 2 distribution",
    "rules": "list and explain the rules",
    "templates": "list, test or copy templates",
    "interfaces": "list or show messages, services and actions",
    "stubs": "write type stubs of rclpy, launch, tf2 and all interfaces for editors",
    "smoke": "build packages, run their executables and observe them",
    "doctor": "diagnose the ROS 2 environments and common mistakes",
    "config": "show the configuration and where each value comes from",
    "cache": "show or clean the cache",
    "trust": "trust a directory whose configuration loads rules and templates",
    "completion": "print the tab completion script for a shell",
}
"""A verb is a module of this package with ``add_arguments`` and ``run``."""
