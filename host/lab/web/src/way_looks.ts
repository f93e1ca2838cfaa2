/** Colours and widths of the path, by report::Doing. */
import type {Colour} from './theme.ts';

export const DOING_COLOURS: Colour[] = ['free', 'table', 'probing', 'danger'];
export const DOING_WIDTHS = [2.5, 3, 2.5, 3.5];
