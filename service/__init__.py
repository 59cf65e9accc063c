"""The web service, the page and the `caesura` command.

app, settings, backend  the application, its settings, and the records, queue and store that routes use
routes                  the calls, one file for each resource
api_keys, auth          API keys, and who may make a request
uploads                 uploads: received, checked and registered
webhooks                calls once a segmentation is over
segmentations           requests for a segmentation, and its status
results                 a result in every format
response_documents      the JSON of all answers
problems                every error as a problem document
http                    the protocol: server, headers, paging
api_description         OpenAPI, descriptions and examples
metrics, request_log    metrics for Prometheus, and a log line for every request
process                 processes: the supervisor and its children
commands                the command
static                  the page
"""
