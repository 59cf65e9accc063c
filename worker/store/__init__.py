"""What lies in files.

blobs            files by key, in a folder or an S3-compatible store
memory_maps      files as buffers
temporary_files  files that are being written
"""
