"""From vertices, frame by frame, to rows of frames: what every loop over frames starts from."""
