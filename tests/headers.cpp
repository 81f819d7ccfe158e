// The headers shared by all tests are precompiled for this source.
