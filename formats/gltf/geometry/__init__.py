"""What lies in the buffers of a glTF: accessors, and the primitives, skin weights and instances made of them."""
