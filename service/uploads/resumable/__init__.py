"""Uploads that go on where they broke off, by tus 1.0 (https://tus.io): its core, creation, expiration and termination.

tus_headers      the headers of the protocol
partial_file     what has come so far, on disk
upload_records   uploads that are not whole yet, in Redis
completion       a whole file becomes an animation
"""
