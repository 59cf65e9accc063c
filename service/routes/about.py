"""What the service offers, and how much it takes."""

from fastapi import APIRouter, Response
from pydantic import BaseModel

from core.limits import Limits
from core.parameters import ALGORITHM, Parameters
from service.answers import answer
from service.backend import Behind
from service.forms import EXPORTS, ExportDocument
from service.methods import MethodDocument, methods

router = APIRouter(prefix="/v1", tags=["about"])


class MethodList(BaseModel):
    """The methods, the one that is taken where none is named, and the version of all of them."""

    algorithm: str
    default: str
    methods: tuple[MethodDocument, ...]


class ExportList(BaseModel):
    """The files that are made of a result."""

    exports: tuple[ExportDocument, ...]


class LimitsDocument(Limits):
    """How large an upload and a model may be."""

    max_upload_bytes: int


@router.get("/methods", response_model=MethodList)
async def list_methods() -> Response:
    """The methods, each with the JSON Schema of its parameters."""
    default = Parameters.model_fields["method"].default
    return answer(MethodList(algorithm=ALGORITHM, default=default, methods=methods()))


@router.get("/exports", response_model=ExportList)
async def list_exports() -> Response:
    """The files that are made of a result: where each is, what it is called, and what it is for."""
    return answer(ExportList(exports=EXPORTS))


@router.get("/limits", response_model=LimitsDocument)
async def limits(backend: Behind) -> Response:
    """How large an upload and a model may be here."""
    settings = backend.settings
    return answer(LimitsDocument(**settings.limits.model_dump(), max_upload_bytes=settings.max_upload_bytes))
