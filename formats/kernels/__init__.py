"""All compiled functions of the formats: sampling of keys, posing of vertices, decoding and encoding of meshopt."""
