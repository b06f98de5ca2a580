"""What xacro makes of a file, as far as that is known without its arguments."""
