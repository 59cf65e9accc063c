"""What the API says of itself: OpenAPI, descriptions, examples, parameters of the methods."""
