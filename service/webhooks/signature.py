"""The signature of a webhook: HMAC-SHA256 of id, time and body, by Standard Webhooks (www.standardwebhooks.com).

Each owner has a key of its own, made of the installation's secret; `GET /v1/callbacks/secret` tells it.
"""

import base64
import hashlib
import hmac

PREFIX = "whsec_"


def shown_secret(key: bytes) -> str:
    """The key as receivers configure it."""
    return PREFIX + base64.b64encode(key).decode()


def signature_headers(key: bytes, identifier: str, seconds: int, body: bytes) -> dict[str, str]:
    """The headers that let the receiver check who called, and that it is not an old call again."""
    signed = f"{identifier}.{seconds}.".encode() + body
    digest = hmac.new(key, signed, hashlib.sha256).digest()
    return {
        "webhook-id": identifier,
        "webhook-timestamp": str(seconds),
        "webhook-signature": "v1," + base64.b64encode(digest).decode(),
    }
