"""Files of the service.

blobs            files by key, in a folder or an S3-compatible store
memory_maps      files mapped as buffers
temporary_files  files while they are written
disk_space       free space on the disk
"""
