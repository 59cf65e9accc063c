"""Requests for a segmentation, and its status.

segmentation_request  the animation, name and parameters of a request
submission            finds or queues the segmentation of a request
document_response     the response with a document, such as a status
event_stream          status changes as server-sent events
"""
