"""Webhooks: calls to an address that a client gave, once a segmentation is over.

callback_url    the address, checked when it is given
signature       the signature of a call, by Standard Webhooks
delivery_queue  calls that are due, claimed one by one
delivery_loop   makes the calls that are due
"""
