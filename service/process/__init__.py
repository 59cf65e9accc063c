"""Processes of one machine.

supervisor     starts and watches the embedded Redis, the workers and the web process
child_process  one child, started again when it ends
web_process    the web process
"""
