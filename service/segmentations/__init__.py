"""Requests for a segmentation, and its status.

segmentation_request  the animation, name and parameters of a request
submission            finds or queues the segmentation of a request
status_response       the response with a status
event_stream          status changes as server-sent events
"""
