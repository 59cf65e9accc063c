"""Files on their way in: received, spooled, registered, where there is room."""
