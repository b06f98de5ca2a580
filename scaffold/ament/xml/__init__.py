"""What ament_xmllint reports about XML files."""
