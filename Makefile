# `make test` and `make demo` need Python >= 3.11, a C compiler and make; no root, no conda.
# The first call sets up .venv in this checkout (about two minutes), later calls start at once.
PYTHON ?= python3
PY := .venv/bin/python
READY := .venv/.ready

# One thread per process: the solves are small and many, threads of BLAS only get in the way.
export OMP_NUM_THREADS ?= 1
export OPENBLAS_NUM_THREADS ?= 1

.PHONY: demo test test-slow faults fuzz mutants coverage lint bench docs clean

demo: $(READY)
	$(PY) -m symid.cli demo

test: $(READY)
	$(PY) -m pytest -n 2 --dist loadfile

test-slow: $(READY)
	$(PY) -m pytest -n 2 -m slow

# Faults on purpose, a list of them with what was not survived; half an hour.
faults: $(READY)
	$(PY) -m pytest -n 2 -m fault

# Odd input of each kind: readers, stores, JSON, declarations, expressions, arguments; 1 to 8 minutes of processor each.
fuzz: $(READY)
	SYMID_FUZZ=4000 $(PY) -m pytest -n 2 tests/faults/test_fuzzed_*.py

# Of lines and branches, by the normal test run, in twice its time; processes that tests start are counted, too.
coverage: $(READY)
	$(PY) -m coverage erase
	$(PY) -m coverage run -m pytest -n 2 --dist loadfile
	$(PY) -m coverage combine --quiet
	$(PY) -m coverage report --fail-under=92

# Small changes of the code that the tests should notice; an hour, `make mutants SAMPLE=5` for a few.
SAMPLE ?= 25
mutants: $(READY)
	-$(PY) tests/mutation.py --sample $(SAMPLE)

lint: $(READY)
	$(PY) -m ruff check symid tests
	$(PY) -m ruff format --check --quiet .
	$(PY) -m mypy

bench: $(READY)
	$(PY) -m symid.cli bench

docs: $(READY)
	NO_MKDOCS_2_WARNING=1 $(PY) -m mkdocs build --quiet -f docs/mkdocs.yml
	@echo 'The pages are in build/docs/index.html'

# A cyipopt that this Python already has (conda-forge) is used through --system-site-packages.
$(READY): pyproject.toml symid/setup_ipopt.py
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "symid needs Python >= 3.11, found `$(PYTHON) --version 2>&1`: run make PYTHON=/path/to/python3.11"; exit 1; }
	test -x $(PY) || if $(PYTHON) -c 'import cyipopt' 2>/dev/null; \
	  then $(PYTHON) -m venv --system-site-packages .venv; else $(PYTHON) -m venv .venv; fi
	$(PY) -m pip install --quiet --editable '.[test]'
	$(PY) -P symid/setup_ipopt.py
	$(PY) -m compileall -q symid
	touch $@

clean:
	rm -rf .venv build dist *.egg-info
