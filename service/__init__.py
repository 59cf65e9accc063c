"""The web service, the page and the `caesura` command.

app, settings, backend  the application, what may be set, what lies behind the routes
routes                  the calls, one file a resource
api_keys, auth          keys; whose request it is, and whether it may be made
uploads                 files on their way in
segmentations           what is asked of an animation, and how far it is
results, documents      a result in every form, and the JSON of all answers
problems                every way a request can fail
http                    the protocol: server, headers, paging, logs of requests
api_description         OpenAPI, descriptions and examples
metrics, request_log    what Prometheus reads, and a line for every request
process                 processes: the supervisor and its children
commands                the command
static                  the page
"""
