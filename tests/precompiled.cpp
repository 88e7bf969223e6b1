// Holds the precompiled header of the tests; empty itself.
