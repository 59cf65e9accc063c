"""Whose request it is. There is one owner for now; keys, and the checks of Host and Origin, belong here."""

from typing import Annotated

from fastapi import Depends

LOCAL_OWNER = ""


async def owner() -> str:
    """The owner of what this request makes and sees."""
    return LOCAL_OWNER


Owner = Annotated[str, Depends(owner)]
