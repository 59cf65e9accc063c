"""What can be chosen by name, one line each. Light: parameters, the API and the command read it, and load no NumPy.

methods      how a take is cut
descriptors  what is measured of a body
"""
