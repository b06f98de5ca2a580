"""Observes one ROS domain and writes what it sees on stdout, line by line in JSON.

This package is copied and run by the Python of the ROS environment, which need not know
``scaffold``: it uses the standard library and rclpy. Events on stdout::

    {"event": "ready"}
    {"event": "graph", "nodes": [...], "topics": [...], "services": [...]}    on every change
    {"event": "message", "topic": "/t", "count": 1}               the first ones of every topic
    {"event": "report", "now": 0.0, "topics": {...}, "parameters": {...}, "log": {...}}

Commands on stdin: ``report`` asks for the last of these events; the end of stdin ends the probe.
"""
