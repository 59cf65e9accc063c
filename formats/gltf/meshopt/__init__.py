"""Buffer views compressed by meshoptimizer (EXT_meshopt_compression, KHR_meshopt_compression), decoded here."""
