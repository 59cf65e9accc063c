# A machine with python3 (3.11 or newer), its venv module and make is enough. Everything lands in this folder.

PYTHON ?= python3
BIN := .venv/bin
# Named after this folder, so that a checkout that was moved or copied sets itself up again.
READY := .venv/ready-$(shell pwd | cksum | cut -d' ' -f1)
LOCKED := pip install --quiet --disable-pip-version-check
# For every platform and Python at once, with digests and without the name of any registry.
RESOLVE := uv pip compile --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-header --quiet
COMPILE := $(RESOLVE) pyproject.toml --extra service --extra s3
LARGE_READERS := --extra alembic --extra usd
BPY ?= bpy>=4.2,<6

.PHONY: addon addon-test chaos docs extras help setup demo test lint audit bench fuzz dist lock clean

help:
	@echo "make demo    set up, start the service, segment two sample figures, show them in the page"
	@echo "make test    set up, then everything that CI runs"
	@echo "make setup   the environment alone: .venv with the command caesura, and the page's libraries"
	@echo "make extras  set up, and install what is large: readers, as the image has them, and what notebooks need"
	@echo "make lint    format, rules, types and layers"
	@echo "make audit   look every locked package up among known vulnerabilities, and the sources for unsafe calls"
	@echo "make docs    the documentation site, with the notebook run and every public name, in build/site"
	@echo "make dist    a wheel and the sources of it, with the page's libraries inside, tried, in dist/"
	@echo "make addon   the Blender add-on as an extension to install from disk, in build/"
	@echo "make addon-test   install Blender as a Python module (374 MB), and test the add-on in it"
	@echo "make bench   measure accuracy, and write docs/accuracy.md: most of an hour"
	@echo "make fuzz    try files made of files for FUZZ_SECONDS (300), then FUZZ_MUTANTS (2000) for each native reader, then requests"
	@echo "make chaos   kill everything at random while takes are segmented; nothing may be lost"
	@echo "make lock    resolve the dependencies anew (needs uv)"
	@echo "make clean   take away all that make made"

setup: $(READY)
	@$(BIN)/python tools/fetch_assets.py

$(READY): locks/development.lock pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "Caesura needs Python 3.11 or newer; this is $$($(PYTHON) --version). Try: make PYTHON=python3.12"; exit 1; }
	@echo "Installing the locked dependencies into .venv; the first time takes a minute."
	@rm -f .venv/ready-*
	@$(PYTHON) -m venv .venv
	@$(BIN)/python -m $(LOCKED) --require-hashes --only-binary :all: -r locks/development.lock
	@$(BIN)/python -m $(LOCKED) --no-deps --no-build-isolation --editable .
	@touch $@

# Readers and libraries that make demo does without; the tests of what is not there are left out.
extras: setup
	@$(BIN)/python -m $(LOCKED) --require-hashes --only-binary :all: -r locks/runtime.lock
	@$(BIN)/python -m $(LOCKED) --require-hashes --only-binary :all: -r locks/notebook.lock

demo: setup
	@$(BIN)/caesura demo

# A process more than processors, for many tests wait; and a file stays in one: its fixtures are started once.
test: lint
	$(BIN)/python -m pytest -n $$(($$(getconf _NPROCESSORS_ONLN) + 1)) --maxprocesses 4 --dist loadfile

lint: setup
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-logo

audit: setup .venv/audit/ready
	$(BIN)/ruff check --select S caesura core formats samples service worker
	$(BIN)/python tools/audit.py

# Apart: pip-audit brings thirty packages that nothing else needs.
.venv/audit/ready: locks/audit.lock | $(READY)
	@$(PYTHON) -m venv .venv/audit
	@.venv/audit/bin/python -m $(LOCKED) --require-hashes --only-binary :all: -r locks/audit.lock
	@touch $@

# Strict: a dead link, a page outside the menu or a name that cannot be found ends it.
docs: extras
	@$(BIN)/python -m $(LOCKED) --require-hashes --only-binary :all: -r locks/docs.lock
	$(BIN)/python -m mkdocs build --strict --quiet

dist: setup
	@rm -rf dist
	$(BIN)/python -m hatchling build -d dist
	$(BIN)/python -m pytest -m release

addon: setup
	@$(BIN)/python tools/build_addon.py

addon-test: setup .venv/blender/ready
	CAESURA_BLENDER_PYTHON=.venv/blender/bin/python $(BIN)/python -m pytest blender/tests

# Apart: 374 MB. Of Blender there is one version for each version of Python; 4.2 to 5.0 are for 3.11.
.venv/blender/ready: | $(READY)
	@$(PYTHON) -m venv .venv/blender
	@.venv/blender/bin/python -m $(LOCKED) '$(BPY)' || { echo "There is no $(BPY) for this Python. Try: make addon-test PYTHON=python3.11"; exit 1; }
	@touch $@

chaos: setup
	$(BIN)/python -m benchmarks.chaos

# TAKES, CMU, REAL: folders; JOIN: glTF files with several clips; PEERS: the Python of benchmarks/peers/requirements.txt. All may be left out.
bench: setup
	$(BIN)/python -m benchmarks.edges
	$(BIN)/python -m benchmarks.repetitions
	$(BIN)/python -m benchmarks.doubt
	$(BIN)/python -m benchmarks.counting $(JOIN)
	$(if $(CMU),$(BIN)/python -m benchmarks.paper.aca_authors --cmu $(CMU))
	$(if $(REAL),$(BIN)/python -m benchmarks.real $(REAL) --methods switching,joint-entropy,luo2014,spectral,aca,haca --invariance 1)
	$(if $(REAL),$(BIN)/python -m benchmarks.real.parts $(REAL))
	$(BIN)/python -m benchmarks.accuracy $(TAKES) $(if $(CMU),--cmu $(CMU)) $(if $(PEERS),--peers $(PEERS)) --figures --held-back 4 --seeds 3

fuzz: setup
	@$(BIN)/python -m $(LOCKED) --require-hashes --only-binary :all: -r locks/fuzz.lock
	@$(BIN)/python -m tests.fuzz
	@$(BIN)/python -m tests.fuzz.native
	@FUZZ_REQUESTS=60,40 $(BIN)/python -m pytest -q --timeout 3000 tests/service/http/test_requests.py

lock:
	@command -v uv > /dev/null || { echo "make lock needs uv on the PATH"; exit 1; }
	$(COMPILE) --upgrade --group assets --group test --group build -o locks/development.lock
	$(COMPILE) $(LARGE_READERS) --upgrade --constraints locks/development.lock -o locks/runtime.lock
	$(RESOLVE) --group notebook --upgrade --constraints locks/development.lock -o locks/notebook.lock
	$(RESOLVE) --group docs --upgrade --constraints locks/development.lock -o locks/docs.lock
	$(RESOLVE) --upgrade --group audit -o locks/audit.lock
	$(RESOLVE) --upgrade --group fuzz -o locks/fuzz.lock

clean:
	rm -rf .venv node_modules service/static/vendor dist build .mypy_cache .ruff_cache .pytest_cache .import_linter_cache .hypothesis .fuzz
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
