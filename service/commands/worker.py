"""`caesura worker`: workers alone, on this or another machine."""

import click

from caesura.service.commands.exit_codes import Command


@click.command(cls=Command, short_help="Run workers alone.")
@click.option("--queues", multiple=True, metavar="NAME,...", help="One worker that takes from these; may be repeated.")
@click.option("--check", is_flag=True, help="End at once: 0 where a worker of this machine is alive, 1 where none is.")
def worker(queues: tuple[str, ...], check: bool) -> None:
    """Take jobs from the Redis that REDIS_URL names, until a signal ends it.

    Without --queues: one worker for `analyse` and `cut`, and one for `cut` alone, so that a new number of motions
    never waits behind a long take.
    """
    from caesura.worker.__main__ import main

    chosen = [word for names in queues for word in ("--queues", names)]
    main([*chosen, *(["--check"] if check else [])])
