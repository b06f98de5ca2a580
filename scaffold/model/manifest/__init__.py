"""package.xml."""
