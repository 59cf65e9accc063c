# A machine with python3 (3.11 or newer), its venv module and make is enough. Everything lands in this folder.

PYTHON ?= python3
BIN := .venv/bin
# Named after this folder, so that a checkout that was moved or copied sets itself up again.
READY := .venv/ready-$(shell pwd | cksum | cut -d' ' -f1)
LOCKED := pip install --quiet --disable-pip-version-check
# For every platform and Python at once, with digests and without the name of any registry.
RESOLVE := uv pip compile --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-header --quiet
COMPILE := $(RESOLVE) pyproject.toml --extra service --extra s3

.PHONY: chaos help setup demo test lint audit bench fuzz dist lock clean

help:
	@echo "make demo    set up, start the service, segment two sample figures, show them in the page"
	@echo "make test    set up, then everything that CI runs"
	@echo "make setup   the environment alone: .venv with the command caesura, and the page's libraries"
	@echo "make lint    format, rules, types and layers"
	@echo "make audit   look every locked package up among known vulnerabilities, and the sources for unsafe calls"
	@echo "make dist    a wheel and the sources of it, with the page's libraries inside, in dist/"
	@echo "make bench   measure accuracy, and write docs/accuracy.md: most of an hour"
	@echo "make fuzz    try files made of files for FUZZ_SECONDS (300)"
	@echo "make chaos   kill everything at random while takes are segmented; nothing may be lost"
	@echo "make lock    resolve the dependencies anew (needs uv)"
	@echo "make clean   take away all that make made"

setup: $(READY)
	@$(BIN)/python tools/fetch_assets.py

$(READY): requirements.lock pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "Caesura needs Python 3.11 or newer; this is $$($(PYTHON) --version). Try: make PYTHON=python3.12"; exit 1; }
	@echo "Installing the locked dependencies into .venv; the first time takes a minute."
	@rm -f .venv/ready-*
	@$(PYTHON) -m venv .venv
	@$(BIN)/python -m $(LOCKED) --require-hashes --only-binary :all: -r requirements.lock
	@$(BIN)/python -m $(LOCKED) --no-deps --no-build-isolation --editable .
	@touch $@

demo: setup
	@$(BIN)/caesura demo

test: lint
	$(BIN)/python -m pytest

lint: setup
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-logo

audit: setup .venv/audit/ready
	$(BIN)/ruff check --select S caesura core formats samples service worker
	$(BIN)/python tools/audit.py

# Apart: pip-audit brings thirty packages that nothing else needs.
.venv/audit/ready: requirements.audit.lock | $(READY)
	@$(PYTHON) -m venv .venv/audit
	@.venv/audit/bin/python -m $(LOCKED) --require-hashes --only-binary :all: -r requirements.audit.lock
	@touch $@

dist: setup
	@rm -rf dist
	$(BIN)/python -m hatchling build -d dist

chaos: setup
	$(BIN)/python -m benchmarks.chaos

# TAKES, CMU: folders; JOIN: glTF files with several clips; PEERS: the Python of benchmarks/peers.txt. All may be left out.
bench: setup
	$(BIN)/python -m benchmarks.edges
	$(BIN)/python -m benchmarks.repetitions
	$(BIN)/python -m benchmarks.doubt
	$(BIN)/python -m benchmarks.counting $(JOIN)
	$(if $(CMU),$(BIN)/python -m benchmarks.aca_authors --cmu $(CMU))
	$(BIN)/python -m benchmarks.accuracy $(TAKES) $(if $(CMU),--cmu $(CMU)) $(if $(PEERS),--peers $(PEERS)) --figures --held-back 4 --seeds 3

fuzz: setup
	@$(BIN)/python -m $(LOCKED) --require-hashes --only-binary :all: -r requirements.fuzz.lock
	@$(BIN)/python -m tests.fuzz

lock:
	@command -v uv > /dev/null || { echo "make lock needs uv on the PATH"; exit 1; }
	$(COMPILE) --upgrade --group assets --group test --group build -o requirements.lock
	$(COMPILE) --upgrade --constraints requirements.lock -o requirements.runtime.lock
	$(RESOLVE) --upgrade --group audit -o requirements.audit.lock
	$(RESOLVE) --upgrade --group fuzz -o requirements.fuzz.lock

clean:
	rm -rf .venv node_modules service/static/vendor dist build .mypy_cache .ruff_cache .pytest_cache .import_linter_cache .hypothesis .fuzz
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
