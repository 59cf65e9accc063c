"""The calls of the API, a file for each resource.

animations, segmentations, results, clips, revisions  the resources
methods_and_limits                                     the methods, exports and limits
collections, collection_takes, collection_proposals, collection_searches   takes in common motions
batches                                                several segmentations in one request
resumable_uploads                                      uploads that go on where they broke off
callback_secret                                        what a receiver of webhooks needs
session                                                sign-in of a browser
health                                                 probes and metrics
pages                                                  the page and its files
"""
