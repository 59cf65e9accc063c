"""Connections that the service makes to addresses that a client has named.

target_url          an address as a client gives it, checked
address_policy      which addresses of the network may be reached
allowed_hosts       hosts that uploads by URL may come from
checked_connection  a connection to the very address that was checked
"""
