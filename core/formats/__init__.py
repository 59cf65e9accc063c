"""Files in, animations out: every format that is read, and the glTF that is written."""
