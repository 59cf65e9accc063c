"""RQ's worker and uvicorn's protocol and server are subclassed. What of their insides we rely on is here.

Where a new version fails this, read its worker or protocol again before the bound in pyproject.toml is raised.
"""

import inspect

import pytest
from rq import Worker
from rq.executions import Execution
from uvicorn import Server
from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

CALLS = [
    (Worker.execute_job, ["job", "queue"]),
    (Worker.fork_work_horse, ["job", "queue"]),
    (Worker.wait_for_horse, []),
    (Worker.perform_job, ["job", "queue"]),
    (Worker.kill_horse, ["sig"]),
    (Worker.maintain_heartbeats, ["job"]),
    (Worker.request_force_stop, ["signum", "frame"]),
    (Worker.handle_work_horse_killed, ["job", "retpid", "ret_val", "rusage"]),
    (Worker.unsubscribe, []),
    (Worker.register_death, []),
    (Execution.__init__, ["id", "job_id", "connection", "worker_name"]),
    (HttpToolsProtocol.connection_made, ["transport"]),
    (HttpToolsProtocol.connection_lost, ["exc"]),
    (HttpToolsProtocol.data_received, ["data"]),
    (HttpToolsProtocol.on_message_begin, []),
    (HttpToolsProtocol.on_headers_complete, []),
    (HttpToolsProtocol.on_body, ["body"]),
    (HttpToolsProtocol.on_message_complete, []),
    (Server.shutdown, ["sockets"]),
]


@pytest.mark.parametrize(("call", "parameters"), CALLS, ids=lambda value: getattr(value, "__qualname__", ""))
def test_a_method_that_is_overridden_or_called_is_as_it_was(call, parameters):
    """The library still has it, with the same parameters."""
    assert list(inspect.signature(call).parameters) == ["self", *parameters]


@pytest.mark.parametrize(
    ("library", "lines"),
    [
        # Who calls what we override, and when.
        (Worker, ["self.execute_job(job, queue)", "self.fork_work_horse(job, queue)", "self.wait_for_horse()"]),
        (Worker, ["self.maintain_heartbeats(job)", "self.unsubscribe()", "self.request_force_stop"]),
        (Worker, ["self._work_horse_killed_handler(job, retpid, ret_val, rusage)"]),
        # What we read or set.
        (Worker, ["self._horse_pid", "self._is_horse", "self.execution", "self.log_result_lifespan"]),
        (Worker, ["self.max_connection_wait_time", "self.last_heartbeat", "self.hostname"]),
        (HttpToolsProtocol, ["self.loop", "self.transport", "self.flow", "self.cycle", ".response_complete"]),
        (HttpToolsProtocol, ["httptools.HttpRequestParser(self)", "access_log"]),
        (Server, ["self.shutdown(sockets=sockets)"]),
    ],
    ids=str,
)
def test_the_library_uses_what_we_override_and_set(library, lines):
    """Its source still has these words: a hook that nobody calls any more would be silent."""
    own = library.__module__.partition(".")[0]
    source = "".join(inspect.getsource(part) for part in library.__mro__ if part.__module__.partition(".")[0] == own)
    assert [line for line in lines if line not in source] == []
