"""The web service and the `caesura` command."""
