"""The calls of the API, a file for each resource.

animations, segmentations, results, clips, revisions  the resources
methods_and_limits                                     the methods, exports and limits
session                                                sign-in of a browser
health                                                 probes and metrics
pages                                                  the page and its files
"""
