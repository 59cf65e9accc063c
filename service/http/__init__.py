"""The protocol: server and address, heads and bodies, headers, paging, the log of requests."""
