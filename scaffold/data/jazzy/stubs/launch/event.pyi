class Event:
    name: str
