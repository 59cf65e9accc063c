"""Collections as the API has them.

documents    the answers
requests     the bodies
membership   animations added and removed
corrections  names, colours and segments that a person sets
proposals    changes that a person accepts or refuses
"""
