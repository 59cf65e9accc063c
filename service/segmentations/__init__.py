"""What is asked of an animation, its submission, and how far it is."""
