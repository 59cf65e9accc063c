"""A service as programs see it.

errors        what may go wrong
exchange      what is asked of a service and what is made of its answers, without a connection
upload        the body of an upload, piece by piece
client        asked one after the other
async_client  asked from asyncio
"""
