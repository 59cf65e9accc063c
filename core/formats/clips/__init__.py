"""What comes out: the uploaded file itself, its take replaced by one named animation for each segment."""
