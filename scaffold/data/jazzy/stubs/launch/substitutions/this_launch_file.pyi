from launch.substitution import Substitution as Substitution

class ThisLaunchFile(Substitution):
    def __init__(self) -> None: ...
