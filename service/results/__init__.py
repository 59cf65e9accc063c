"""A finished result in every format.

result_formats    the formats and exports
result_response   the response with a result or a file made of it
text_formats      CSV, WebVTT and SVG
elan              annotations for ELAN
byte_ranges       stored files, whole or by Range
pictures          pictures of poses that the page drew, kept with the result
revision_request  the revision of a request
"""
