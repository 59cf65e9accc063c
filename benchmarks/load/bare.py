"""What FastAPI does on this machine with a route that does nothing: `python -m benchmarks.load.bare --socket N`."""

import argparse
import socket

import uvicorn
from fastapi import FastAPI

from caesura.service.http.server import configuration

app = FastAPI()


@app.get("/bare/{identifier}")
async def bare(identifier: str) -> dict[str, str]:
    """An answer that needs nothing."""
    return {"id": identifier, "status": "done"}


def main() -> None:
    """Serve as the service does, with the same settings of uvicorn."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--socket", type=int, required=True)
    listening = socket.socket(fileno=parser.parse_args().socket)
    uvicorn.Server(configuration(app)).run(sockets=[listening])


if __name__ == "__main__":
    main()
