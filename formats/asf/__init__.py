"""ASF and AMC (Acclaim): a skeleton and its motion as two texts, read as a glTF of the same skeleton.

skeleton         the bones of an ASF
motion           the angles of an AMC
amc_header       the answer to an upload
gltf_conversion  the bones as nodes, turned by the angles
"""
