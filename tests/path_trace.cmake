# Tests of path_trace.
