# Needs make and Python >= 3.11, nothing else. `make help` lists what there is.
SHELL := /bin/sh
.DEFAULT_GOAL := help
.PHONY: help reproduce test proof docs bench clean

VENV := .venv
BIN := $(VENV)/bin
PINS := pyproject.toml constraints.txt
REPORT ?= report

help: ## say what there is
	@sed -n 's/^\([a-z]*\):.*## /make \1\t/p' $(MAKEFILE_LIST)

reproduce: $(VENV)/installed ## derive, verify and solve everything; write the report
	@$(BIN)/wear reproduce -o $(REPORT)
	@echo "The report lies in $(REPORT)/report.html"

# The processes that tests start share bytecode, whatever the user's shell says.
# Every check runs, whatever the others found. Types are checked while the tests run; pytest, which
# takes longer, closes the output.
test: export PYTHONDONTWRITEBYTECODE :=
test: $(VENV)/installed-test ## run all checks: style, types, import walls, tests, doctests
	@status=0; \
	$(BIN)/ruff check || status=1; \
	$(BIN)/ruff format --check || status=1; \
	$(BIN)/lint-imports --no-logo || status=1; \
	$(BIN)/mypy & types=$$!; \
	$(BIN)/python -m pytest -n 2 || status=1; \
	wait $$types || status=1; \
	exit $$status

proof: $(VENV)/installed ## prove the steps of the derivation anew with Coq
	@$(BIN)/derive export --target coq -o build/proof --check

docs: $(VENV)/installed-docs ## build the documentation
	@$(BIN)/sphinx-build -W -q -b html docs docs/_build/html
	@echo "The documentation lies in docs/_build/html/index.html"

bench: $(VENV)/installed-docs ## measure speed against error anew, about five minutes: docs/bench and README
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -e '.[peers]'
	@$(BIN)/wear bench --peers -o docs/bench
	@mv docs/bench/speed.json wear/data/speed.json
	@$(BIN)/python docs/bench/readme.py

clean: ## remove everything that the targets above made
	rm -rf $(VENV) $(REPORT) build dist *.egg-info docs/_build
	rm -rf .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# Installed anew only when the requirements or their pins change.
$(VENV)/installed: $(PINS) | $(BIN)/pip
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[report]'
	@touch $@

$(VENV)/installed-test: $(PINS) | $(BIN)/pip
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[test]'
	@touch $@

$(VENV)/installed-docs: $(PINS) | $(BIN)/pip
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[docs]'
	@touch $@

# A name on the PATH may be a stub, an old version or lack ensurepip: each is tried before it is taken.
# pip comes last in a new environment, so a half-made one is made again.
$(BIN)/pip:
	@for python in $(PYTHON) python3.13 python3.12 python3.11 python3.14 python3 python; do \
	    if "$$python" -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1; then \
	        exec "$$python" -m venv --clear $(VENV); \
	    fi; \
	done; \
	echo "No Python >= 3.11 with venv was found. Install one (Debian, Ubuntu: apt install python3 python3-venv)," >&2; \
	echo "or name it: make $(MAKECMDGOALS) PYTHON=/path/to/python3" >&2; \
	exit 1
