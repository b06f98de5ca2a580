"""Observes one ROS domain and writes events to stdout as JSON lines.

This package is copied and run by the Python of the ROS environment, which need not know
``scaffold``: it uses the standard library and rclpy. Events on stdout::

    {"event": "ready"}
    {"event": "graph", "nodes": [...], "topics": [...], "services": [...]}    on every change
    {"event": "message", "topic": "/t", "count": 1}               the first ones of every topic
    {"event": "report", "now": 0.0, "topics": {...}, "parameters": {...}, "log": {...}}

    {"event": "answer", "id": 1, "value": {...} or null, "error": ""}
    {"event": "refused", "topic": "/t", "error": "..."}             a message cannot be published

Commands on stdin are JSON as well; the end of stdin ends the probe::

    {"command": "report"}
    {"command": "fields", "topics": {"/t": ["header.frame_id"]}}    values to look at
    {"command": "publish", "topic", "type", "message", "rate"}
    {"command": "call", "id", "kind": "service" or "action", "name", "type", "request", "timeout"}
"""
