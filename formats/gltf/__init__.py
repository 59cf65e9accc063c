"""glTF 2.0: GLB or JSON, read into an animation, and written.

container, document, json_object  the outer shape, the lists of its JSON, and one checked object of it
summary                           what the JSON says with hardly any data
geometry                          accessors, buffers, primitives, skin weights, instances
draco, meshopt                    compressed geometry
animation                         takes, channels, keys, and their values at any time
posing                            nodes, skins, and vertices of any block of frames
scene_mesh                        all that is drawn of a scene, as one body
read, writer                      the steps of reading in order; a GLB written
"""
