"""The HTTP protocol.

server            uvicorn, with an end in order
protocol          limits of header size, and of idle time
listening_socket  the listening socket and its address
json_body         a JSON request body
query_names       refuses unknown query names
paging            lists by pages
prefer_header     the Prefer header: the time to wait for a result
stream_limit      the limit of open event streams
security_headers  headers that protect the page in a browser
file_name         file names that are safe to show and to save
compression       answers as zstd or gzip
outgoing          connections to addresses that a client names, checked
head_requests     HEAD, answered as GET without its body
"""
