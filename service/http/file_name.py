"""The name of a file as it is shown and saved."""

LONGEST_NAME = 200


def plain_name(path: str) -> str:
    """The last step of a path, without what does not print, such as marks of direction; empty where nothing is left."""
    last = path.replace("\\", "/").rpartition("/")[2]
    return "".join(letter for letter in last if letter.isprintable()).strip(" .")[:LONGEST_NAME]
