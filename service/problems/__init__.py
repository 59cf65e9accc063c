"""Every way a request can fail, as problem documents (RFC 9457): one table of statuses, one set of handlers."""
