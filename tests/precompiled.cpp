// The source that tests/precompiled.h is compiled with.
