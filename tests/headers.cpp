// Source for which the headers shared by all tests are precompiled.
