"""glTF 2.0: GLB or JSON, read into an animation, and written.

read                        the steps of reading in order
container                   the GLB container and the JSON
gltf_document, json_object  the lists of the JSON, and one checked object of it
summary                     takes and sizes from the JSON alone
geometry                    accessors, buffers, primitives, skin weights, instances
draco, meshopt              compressed geometry
animation                   takes, channels, keys, and their values at any time
posing                      nodes, skins, and vertices of any block of frames
scene_mesh                  everything that the scene draws, as one mesh
skeleton_joints             the joints of a file without a mesh
converted_gltf              what another format becomes
writer                      a GLB from arrays
"""
