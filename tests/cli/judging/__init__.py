"""The judge's checks, written from the file formats alone: they share no code with the product."""
