from launch.descriptions.executable import Executable as Executable
