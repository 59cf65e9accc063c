"""Uploads.

upload_body   receives a body in blocks
multipart     parses a multipart form as it streams
spool         writes a file to disk while it is received
body_limit    limits the size of every request body
capacity      refuses new work when Redis, the disk or the store is full
registration  registers the files as an animation
"""
