"""Authentication of requests.

middleware      checks every request before a route sees it
authentication  finds the caller by API key or session
sessions        browser sessions
origins         refuses requests from other web pages
rate_limit      the rate limit of a key and address
request_owner   the owner of the data that a request sees
"""
