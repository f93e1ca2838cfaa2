"""What the judge knows, written from the file formats alone: it shares no code with the product."""
