# Tests of trace.
