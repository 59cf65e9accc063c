"""Characters made by the project itself, performing motions whose truth is known."""
