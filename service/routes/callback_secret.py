"""What a receiver of webhooks needs."""

from anyio import to_thread
from fastapi import APIRouter
from pydantic import BaseModel, Field

from caesura.service.auth.request_owner import Owner
from caesura.service.backend import BackendDependency
from caesura.service.webhooks.signature import shown_secret
from caesura.worker.records import content_ids

router = APIRouter(prefix="/v1/callbacks", tags=["callbacks"])


class CallbackSecret(BaseModel):
    """The key that webhooks are signed with."""

    secret: str = Field(description="as Standard Webhooks has it: `whsec_` and base64")


@router.get("/secret")
async def get_callback_secret(backend: BackendDependency, owner: Owner) -> CallbackSecret:
    """Tell the key that your webhooks are signed with.

    It is the same for all calls made for this owner, and made of the secret of the installation.
    """
    secret = await to_thread.run_sync(lambda: backend.secret)
    return CallbackSecret(secret=shown_secret(content_ids.webhook_secret(secret, owner)))
