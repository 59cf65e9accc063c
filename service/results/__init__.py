"""A finished result in every form: formats, text, byte ranges, revisions."""
