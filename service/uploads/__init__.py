"""Uploads.

upload_body   receives a body in blocks
remote_file   fetches an upload from an address
resumable     goes on where an upload broke off, by tus
multipart     parses a multipart form as it streams
spool         writes a file to disk while it is received
body_limit    limits the size of every request body
content_encoding  inflates bodies that come as gzip
capacity      refuses new work when Redis, the disk or the store is full
registration  registers the files as an animation
"""
