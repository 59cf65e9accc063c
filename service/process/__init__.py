"""Processes: the supervisor of a machine, the children it watches, the web process."""
