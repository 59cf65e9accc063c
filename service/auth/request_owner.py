"""Whose request it is, as the door (service/auth/middleware.py) found it."""

from typing import Annotated

from fastapi import Depends, Request

LOCAL_OWNER = ""
"""Everybody, where no keys are needed."""


async def request_owner(request: Request) -> str:
    """The owner of what this request makes and sees."""
    found: str = request.state.visitor.owner
    return found


Owner = Annotated[str, Depends(request_owner)]
